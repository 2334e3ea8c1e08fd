// What is wrong in this picture? A known mistake, its picture alive, and four lines to choose from.
(() => {
    const { made } = Page;
    const shuffled = (list) => {
        const all = [...list];
        for (let i = all.length - 1; i > 0; --i) {
            const j = Math.floor(Math.random() * (i + 1));
            [all[i], all[j]] = [all[j], all[i]];
        }
        return all;
    };

    const sentence = (text) => (/^\w\b/.test(text) ? text : text[0].toUpperCase() + text.slice(1));

    /** Right and wrong, with a slider across. */
    function pair_of(step, mistake) {
        const picture = (name, alt) => made('img', { src: `exercises/${step}/gallery/${name}.png`, alt });
        const compare = made('div', { className: 'compare' }, picture('right', 'right'), picture(mistake.id, 'wrong'));
        Page.slide(compare);
        return compare;
    }

    const lines_of = (mistake) => {
        const code = made('code');
        for (const line of mistake.lines) {
            const kind = { '+': 'hljs-addition', '-': 'hljs-deletion' }[line[0]];
            code.append(made('span', { className: kind ?? '', textContent: line }), '\n');
        }
        return made('pre', { className: 'diff', tabIndex: 0 }, code);
    };

    class Quiz {
        constructor(section, mistakes, live) {
            Object.assign(this, { section, live, code: mistakes.code, all: mistakes.list, queue: [] });
            this.shows = made('p');
            this.answers = made('div', { className: 'answers' });
            this.after = made('div');
            this.after.setAttribute('aria-live', 'polite');
            section.append(this.shows, this.answers, this.after);
        }

        async next() {
            if (!this.queue.length) this.queue = shuffled(this.all);
            this.mistake = this.queue.pop();
            this.live.view.use(await this.code(this.mistake));
            this.live.reset();
            this.shows.textContent = 'One line of this program is wrong. Drag the picture, look from other sides, then choose.';
            const near = this.all.filter((each) => each !== this.mistake && each.file === this.mistake.file);
            const far = this.all.filter((each) => each.file !== this.mistake.file);
            const others = [...shuffled(near).slice(0, 2), ...shuffled(far)].slice(0, 3);
            this.after.replaceChildren();
            this.answers.replaceChildren(...shuffled([this.mistake, ...others]).map((each) => {
                const button = made('button', { type: 'button', textContent: `${sentence(each.title)} (${each.file.split('/').at(-1)})` });
                button.onclick = () => this.judge(button, each);
                return button;
            }));
        }

        judge(button, choice) {
            const right = choice === this.mistake;
            button.className = right ? 'good' : 'bad';
            button.dataset.mark = right ? '✓' : '✗';
            button.disabled = true;
            if (right) this.explain();
            else this.after.replaceChildren(made('p', { textContent: `No. With that mistake: ${choice.shows}` }));
        }

        explain() {
            for (const button of this.answers.children) button.disabled = true;
            const { title, file, shows, why, fix } = this.mistake;
            const mend = made('button', { type: 'button', className: 'small', textContent: 'Mend it' });
            mend.onclick = async () => { this.live.view.use(await Page.step(this.live.step)); this.live.draw(); mend.disabled = true; };
            const more = made('button', { type: 'button', className: 'small', textContent: 'Another one', onclick: () => this.next() });
            this.after.replaceChildren(
                made('p', {}, made('strong', { textContent: `Right: ${title}. ` }), sentence(shows)), pair_of(this.live.step, this.mistake),
                made('p', { className: 'source', textContent: `steps/${file}` }), lines_of(this.mistake),
                made('p', { textContent: sentence(why) }), made('p', {}, made('em', { textContent: 'Fix: ' }), fix),
                mend, ' ', more);
        }
    }

    function offer(section) {
        const begin = made('button', { type: 'button', className: 'small', textContent: 'Show me a picture' });
        section.append(made('h3', { textContent: 'What is wrong in this picture?' }),
            made('p', { textContent: 'Each picture is made by the program of this step with one mistake in it, as learners make them.' }), begin);
        begin.onclick = async () => {
            begin.disabled = true;
            try {
                const mistakes = await Page.mistakes_of(section.dataset.step);
                const figure = made('figure', { className: 'live' });
                figure.dataset.step = section.dataset.step;
                section.append(figure);
                const quiz = new Quiz(section, mistakes, await Page.enliven(figure));
                begin.remove();
                await quiz.next();
                section.quiz = quiz;
            } catch (problem) {
                begin.replaceWith(made('p', { className: 'state problem', textContent: problem.message }));
            }
        };
    }
    Page.all('.quiz').forEach(offer);
})();
